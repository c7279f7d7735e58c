#!/usr/bin/python3
"""Reading test.bag without ROS, by Python alone. Prints load over extension from the topic knot/state (msg/KnotState.msg).
Run:  build/devel/lib/knot_utm/tensile_test tighten --bag --out out/tighten
      python3 examples/read_bag_without_ros.py out/tighten/test.bag
Test: build/devel/lib/knot_utm/tensile_test straight --set physics.accuracy=draft --quiet --bag --out out/straight &&
      python3 examples/read_bag_without_ros.py out/straight/test.bag
Prints: time,phase,extension,load\\ns,-,m,N\\n(.*\\n)*.*,pull,0[.]00\\d+,[\\d.]+\\n"""
import sys
from struct import unpack_from


def blocks(data, at=0):
    """A bag is blocks of bytes, each after its length."""
    while at < len(data):
        end = at + 4 + unpack_from("<I", data, at)[0]
        yield data[at + 4:end]
        at = end


def fields(data):
    return dict(part.split(b"=", 1) for part in blocks(data))


def messages(data, topics):
    """(topic, message as bytes) in order. A record is a header of fields and a body; the body of a chunk is records."""
    parts = blocks(data)
    for header, body in zip(parts, parts):
        field = fields(header)
        if field[b"op"] == b"\5":  # a chunk; tensile_test does not compress it
            yield from messages(body, topics)
        elif field[b"op"] == b"\7":  # a topic, whose fields also say how its messages are laid out
            topics[field[b"conn"]] = field[b"topic"].decode()
        elif field[b"op"] == b"\2":  # a message
            yield topics[field[b"conn"]], body


def text(data, at):
    end = at + 4 + unpack_from("<I", data, at)[0]
    return data[at + 4:end].decode(), end


print("time,phase,extension,load\ns,-,m,N")
with open(sys.argv[1], "rb") as bag:
    bag.readline()  # #ROSBAG V2.0
    for topic, state in messages(bag.read(), {}):
        if topic.endswith("knot/state"):
            _, at = text(state, 12)  # the frame of the header, after its number and stamp
            time = unpack_from("<d", state, at + 12)[0]  # after run and sequence
            phase, at = text(state, at + 20)
            _, extension, _, _, load = unpack_from("<5d", state, at)  # displacement, extension, end_to_end, knot_distance, load
            print(f"{time:.3f},{phase},{extension:.6f},{load:.4f}")
