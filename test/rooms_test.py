#!/usr/bin/python3
"""The rooms of the core use each other as cmake/rooms.txt says, and none of them knows of ROS."""
import glob
import os
import re
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
AROUND = ["ros", "nodes", "tools"]  # what is built on the core


def table_of_rooms():
    """Each room of the core with all rooms that it may use, by way of others too."""
    table = {}
    with open(os.path.join(ROOT, "cmake/rooms.txt"), encoding="utf-8") as file:
        for line in file:
            if line.strip() and line[0] not in "#=":
                room, *used = line.replace(":", " ").split()
                table[room] = {room}.union(*(table[other] for other in used))  # which must stand above
    return table


def found(pattern, rooms):
    """(Room, what matches in a line, where) of the files of these rooms."""
    for room in rooms:
        for tree in ("src", "include/knot_utm"):
            for name in glob.glob(os.path.join(ROOT, tree, room, "**/*"), recursive=True):
                if os.path.isfile(name):
                    with open(name, encoding="utf-8") as file:
                        for match in re.finditer(pattern, file.read(), re.MULTILINE):
                            yield room, match[match.re.groups and 1], f"{name}: {match[0]}"


class Rooms(unittest.TestCase):
    table = table_of_rooms()

    def test_are_all_in_the_table(self):
        rooms = {room for tree in ("src", "include/knot_utm") for room in os.listdir(os.path.join(ROOT, tree))}
        self.assertEqual(rooms - {"knot_utm"}, {*self.table, *AROUND})

    def test_use_only_those_that_the_table_says(self):
        for room, used, where in found(r'^\s*#\s*include\s*"knot_utm/(\w+)/.*', self.table):
            self.assertIn(used, self.table[room], where)

    def test_no_file_reaches_into_another_room(self):
        self.assertEqual([*found(r'^\s*#\s*include\s*"\.\..*', [*self.table, *AROUND])], [])

    def test_no_core_file_includes_ros_or_a_message(self):
        """Message headers end in .h and begin with a capital letter; those of the core end in .hpp."""
        self.assertEqual([*found(r'^\s*#\s*include\s*[<"](?:(?:knot_utm/)?(?:ros|rosbag|tf2[a-z_]*|actionlib)/|[a-z0-9_]+/[A-Z]\w*\.h[>"]).*',
                                 self.table)], [])

    def test_nodes_read_no_clock_that_somebody_sets(self):
        """Anybody may publish /clock, and the clock of the machine is set by others too."""
        self.assertEqual([*found(r"Time::now|system_clock|WallTime\b|WallTimer\b|createTimer|ros::Rate|WallRate|gettimeofday|\btime\(nullptr|"
                                 r"THROTTLE|DELAYED", ["ros", "nodes"])], [])


if __name__ == "__main__":
    unittest.main()
