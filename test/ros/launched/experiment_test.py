#!/usr/bin/python3
"""experiment.launch: the crosshead goes as an experiment's did, the record is played beside the test, and the panel has both
curves."""
import csv
import os
import subprocess
import unittest

from knot_utm.panel.drawing import MEASURED, OURS
from launched import TOOL, Launch, wait_for

IMPORT = os.path.join(os.path.dirname(TOOL), 'import_instron')
# Of a machine that went forth and back, at other speeds than any program of ours: [s], [m], [N].
RECORD = [(0.0, 0.0, 0.0), (0.5, 0.5e-3, 147.0), (1.0, 1.1e-3, 307.0), (1.5, 1.4e-3, 399.0), (2.0, 1.3e-3, 368.0)]


def prepare(folder):
    """Of a machine, and of a load cell alone (LineScale)."""
    raw = {'record': 'Time (s),Extension (m),Load (N)\n' + ''.join('%r,%r,%r\n' % row for row in RECORD),
           'line': 'LogNo=1\nUnit=N\nMode=ABS\nSpeed=2\n' + ''.join('%r\n' % load for _, _, load in RECORD)}
    for name, text in raw.items():
        with open('%s/raw_%s.csv' % (folder, name), 'w', encoding='utf-8') as file:
            file.write(text)
        for end in '.csv', '.bag':
            subprocess.run([IMPORT, file.name, folder + '/' + name + end, '--quiet'], check=True)


def launched(*words):
    return Launch(*words, 'method:=straight', 'real_time_factor:=0', 'rate:=1',
                  "overrides:='machine.load_cell={capacity: 50e3, sampling_rate: 100}'",
                  command=['roslaunch', 'knot_utm', 'experiment.launch'], prepare=prepare)


def readings_of(launch):
    """Stamps and loads of the record in test.bag, how often its crosshead is there, and the rows of the curve."""
    import rosbag
    with rosbag.Bag(launch.out + '/test.bag') as bag:
        loads = [(message.header.stamp.to_sec(), message.wrench.force.z)
                 for _, message, _ in bag.read_messages(topics=['/experiment/load_cell'])]
        places = bag.get_message_count('/experiment/crosshead')
    return loads, places, list(csv.DictReader(launch.text('curve.csv').splitlines()))[1:]


class ExperimentTest(unittest.TestCase):

    def test_beside_the_own_pull(self):
        for word, travels in ('data:=line.csv', False), ('bag:=record.bag', True):
            with self.subTest(word), launched(word) as launch:
                self.assertEqual(launch.end(), 0, launch.console())
                self.assertNotEqual('line.csv: it has no travel to follow' in launch.console(), travels)
                loads, places, rows = readings_of(launch)
                self.assertEqual(places, len(RECORD) * travels)
                begin = max(float(row['time']) for row in rows if row['phase'] == 'balance')
                self.assertEqual([(round(stamp - begin, 6), load) for stamp, load in loads], [row[::2] for row in RECORD])

    def test_both_curves(self):
        with launched('data:=record.csv', 'exit_at_end:=false') as launch:
            wait_for('the panel', lambda: launch.answers('panel_node'))
            os.environ.update(launch.environment)
            # Not before: they take the master's address when they are loaded.
            import client
            import rospy
            from sensor_msgs.msg import Image
            rospy.init_node('experiment_test', disable_signals=True)
            panels = client.Latest('view/panel', Image)
            panels.wait('both curves', lambda image: client.shows(image, OURS) and client.shows(image, MEASURED))
            wait_for('the result', lambda: os.path.exists(launch.out + '/result.yaml'))
            self.assertEqual(launch.result('ended_by'), 'program')
            loads, places, rows = readings_of(launch)
        self.assertEqual(places, len(RECORD))
        # From the beginning of the record on, the crosshead is where the record has it.
        begin = float(rows[-1]['time']) - RECORD[-1][0]
        for time, extension, _ in RECORD:
            ours = min(rows, key=lambda row, at=begin + time: abs(float(row['time']) - at))
            self.assertAlmostEqual(float(ours['extension']), extension, delta=1e-9)
        self.assertEqual([(round(stamp - begin, 6), load) for stamp, load in loads], [(time, load) for time, _, load in RECORD])


if __name__ == '__main__':
    unittest.main()
