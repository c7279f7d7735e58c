#!/bin/bash
# Eight readings of a load that bear the same time, in one bag of ROS 1, by three readers of bags.
#
# A recorder stamps messages with /clock. While simulated time stands (a paused simulator, or several messages within one step) a topic has
# many messages of one stamp, and which came first is all that tells the newest. The bag here is written by rosbag itself: loads 0 to 7 and
# extensions 0 to 7, taken in turn, all at 11 s; then half a second left, as a negative std_msgs/Duration; then rates.
#
# Guessed: every reader gives messages of one time in the order in which they were written; a duration of -0.5 s is read as -0.5 s.
# Seen: Python's rosbag 1.15.15 keeps the order within a topic, but gives all of one topic before the next. npm's rosbag 5.0.0 keeps both.
# @foxglove/rosbag 0.4.1 shuffles messages even within a topic, always the same way: loads come as 0, 2, 6, 5, 7, 1, 3, 4. npm's rosbag reads
# -0.5 s as 4,294,967,295.5 s; the other two have it right.
# Rates that rosbag states are one over the median of the steps between messages, not messages per second: bursts of ten messages 10 ms apart,
# one burst each 10 s, are "100 Hz"; messages in pairs of one stamp have None.
# Why it matters: a curve drawn from such a bag goes back and forth, and pairs a load with another reading's extension. Sort by header.seq or a
# number in the message, join topics by the stamps in their headers, and do not record while the clock stands.
#
# usage: findings/bag_messages_of_one_time.sh
# It loads Debian and npm packages into a temporary folder, needs node, installs nothing, and ends with 1 where one of them does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download python3-rosbag=1.15.15+ds-2 python3-catkin python3-catkin-pkg python3-genmsg python3-genpy python3-gnupg \
  python3-dateutil python3-pycryptodome python3-pyparsing python3-roscpp-msg python3-rosgraph python3-rosgraph-msgs python3-roslib \
  python3-roslz4 python3-rospkg python3-rospy python3-six python3-std-msgs python3-yaml libroslz4-1d libyaml-0-2 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
npm install --silent --no-audit --no-fund --prefix . rosbag@5.0.0 @foxglove/rosbag@0.4.1 @foxglove/rosmsg@5.0.5 \
  @foxglove/rosmsg-serialization@2.0.4 tslib@2.8.1
cat > readers.mjs <<'JS'
import { createRequire } from "node:module";
const require = createRequire(import.meta.url);
const read = { rosbag: {}, "@foxglove/rosbag": {} };
const take = (reader, topic, message) => (read[reader][topic] ??= []).push(message.data) && (read[reader].order ??= []).push(topic[1]);

const bag = await require("rosbag").open("readings.bag");
await bag.readMessages({}, ({ topic, message }) => take("rosbag", topic, message));

const { Bag } = require("@foxglove/rosbag"), { FileReader } = require("@foxglove/rosbag/node");
const { parse } = require("@foxglove/rosmsg"), { MessageReader } = require("@foxglove/rosmsg-serialization");
const other = new Bag(new FileReader("readings.bag"));
await other.open();
for await (const { topic, data, connectionId } of other.messageIterator())
  take("@foxglove/rosbag", topic, new MessageReader(parse(other.connections.get(connectionId).messageDefinition)).readMessage(data));
console.log(JSON.stringify(read));
JS
PYTHONPATH=tree/usr/lib/python3/dist-packages LD_LIBRARY_PATH=tree/usr/lib/x86_64-linux-gnu /usr/bin/python3 -S - <<'PYTHON'
import json
import subprocess
import genpy
import rosbag
from std_msgs.msg import Duration, Float64

at = genpy.Time(11)
with rosbag.Bag("readings.bag", "w") as bag:
    for k in range(8):
        bag.write("/load", Float64(k), at)
        bag.write("/extension", Float64(k), at)
    bag.write("/time_left", Duration(genpy.Duration(-1, 500000000)), genpy.Time(12))
with rosbag.Bag("rates.bag", "w") as bag:
    for k in range(100):
        bag.write("/bursts", Float64(k), genpy.Time.from_sec(1 + 10 * (k // 10) + 0.01 * (k % 10)))
        bag.write("/pairs", Float64(k), genpy.Time(1 + k // 2))


def left(value):
    return value["sec"] + value["nsec"] * 1e-9 if isinstance(value, dict) else value.to_sec()


read = json.loads(subprocess.run(["node", "readers.mjs"], capture_output=True, text=True, check=True).stdout)
read["Python's rosbag"] = {"order": []}
with rosbag.Bag("readings.bag") as bag:
    for topic, message, _ in bag.read_messages():
        read["Python's rosbag"].setdefault(topic, []).append(message.data)
        read["Python's rosbag"]["order"].append(topic[1])
seen = {name: ("".join("%g" % value for value in topics["/load"]), "".join(topics["order"]), left(topics["/time_left"][0]))
        for name, topics in sorted(read.items())}
with rosbag.Bag("rates.bag") as bag:
    rates = bag.get_type_and_topic_info()[1]
    seen["rates"] = {topic: rates[topic].frequency and round(rates[topic].frequency) for topic in sorted(rates)}
expected = {
    "@foxglove/rosbag": ("02657134", "llleeeleeeeellllt", -0.5),
    "Python's rosbag": ("01234567", "lllllllleeeeeeeet", -0.5),
    "rosbag": ("01234567", "lelelelelelelelet", 4294967295.5),
    "rates": {"/bursts": 100, "/pairs": None},
}
print("loads in order of reading; first letters of the topics in order (written as lele...); a duration of -0.5 s")
for key, value in seen.items():
    print(f"{key}: {value}" + ("" if value == expected.get(key) else f"   expected {expected.get(key)}"))
raise SystemExit(seen != expected)
PYTHON
