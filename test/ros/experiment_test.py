#!/usr/bin/python3
"""experiment.launch: the crosshead goes as an experiment's did, and both curves are on topics, at the same times."""
import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from knot_utm.msg import Crosshead, RecorderStatus, TestStatus
from node_test import Latest, start_test, wait_for_connection

MEASURED = [(0.0, 0.10e-3, 3.0), (0.5, 0.60e-3, 150.0), (1.0, 1.20e-3, 310.0), (1.5, 1.50e-3, 402.0),
            (2.0, 1.40e-3, 371.0)]


class ExperimentTest(unittest.TestCase):

    def test_side_by_side(self):
        rospy.init_node('experiment_test')
        simulated = Latest('utm/crosshead', Crosshead)
        measured = Latest('experiment/crosshead', Crosshead)
        load = Latest('experiment/load_cell', WrenchStamped)
        recorder = Latest('recorder/status', RecorderStatus)
        status = Latest('utm/status', TestStatus)
        wait_for_connection('utm_node', 'utm/crosshead', 'experiment_node')
        for publisher, topic in (('utm_node', 'utm/crosshead'), ('experiment_node', 'experiment/crosshead'),
                                 ('experiment_node', 'experiment/load_cell')):
            wait_for_connection(publisher, topic, rospy.get_name())
        start_test()
        self.assertEqual(status.wait('ended', lambda s: s.state == TestStatus.ENDED).ended_by, 'program')
        self.addCleanup(shutil.rmtree, recorder.wait('recorded', lambda r: r.complete).directory)

        self.assertEqual([m.time for m in measured.messages], [row[0] for row in MEASURED])
        # Raw data that show no rest: the first reading is their zero, as `compare --balance` has it.
        for (_, extension, force), message, cell in zip(MEASURED, measured.messages, load.messages):
            self.assertAlmostEqual(message.displacement, extension - MEASURED[0][1], delta=1e-12)
            self.assertAlmostEqual(cell.wrench.force.z, force - MEASURED[0][2], delta=1e-9)
        self.assertEqual([m.header.stamp for m in load.messages], [m.header.stamp for m in measured.messages])
        # At its stamp each reading has its counterpart, whose crosshead has gone as far since the record began.
        ours = {round(m.header.stamp.to_sec(), 6): m.displacement for m in simulated.messages}
        begin = ours[round(measured.messages[0].header.stamp.to_sec(), 6)]
        for (_, extension, _), message in zip(MEASURED, measured.messages):
            there = ours[round(message.header.stamp.to_sec(), 6)] - begin
            self.assertAlmostEqual(there, extension - MEASURED[0][1], delta=1e-9)


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'experiment', ExperimentTest)
