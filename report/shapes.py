"""The rod as it lay at given times of a test: from its bag, else the final shape alone."""
import os

import numpy as np

from run import numbers, read_columns

SHAPE, STATE = "knot/shape", "knot/state"


class Shape:
    """`tension`: of each edge [N]; None: not known. `time` of the test [s]."""

    def __init__(self, time, points, tension):
        self.time, self.points, self.tension = time, points, tension


def pieces(shape, whole):
    """Slices of the nodes between which the rod has parted; a lone node cannot be drawn. `whole`: a shape before that.
    An edge that has grown twice as much as the usual one is no longer there: a rod does not stretch so unevenly."""
    if len(shape.points) != len(whole.points):
        return [slice(0, len(shape.points))]
    growth = lengths(shape) / lengths(whole)
    gaps = np.flatnonzero(growth > 2.0 * np.median(growth)) + 1
    ends = [0, *gaps.tolist(), len(shape.points)]
    return [slice(a, b) for a, b in zip(ends[:-1], ends[1:]) if b - a >= 2]


def lengths(shape):
    return np.linalg.norm(np.diff(shape.points, axis=0), axis=1)


def shapes_at(run, times, broke=None):
    """The shape nearest to each time that has one, in the order of `times`, and what is to be said of them: a line, or
    nothing. Of a time before the rod `broke` a shape that is from before that."""
    bag = os.path.join(run.folder, "test.bag")
    if not os.path.exists(bag):
        return [final_shape(run)], "There is no test.bag, so only the final shape is shown, without tensions."
    try:
        return shapes_of_bag(bag, times, broke), ""
    except ModuleNotFoundError as missing:
        why = f"{missing} (Debian: python3-rosbag)"
    except Exception as error:  # a bag is read by code that its own content chooses: anything may go wrong
        why = " ".join(str(error).split()) or type(error).__name__
    return [final_shape(run)], f"test.bag cannot be read, so only the final shape is shown, without tensions: {why}"


def final_shape(run):
    file = os.path.join(run.folder, "final_shape.csv")
    columns = read_columns(file)
    points = np.column_stack([numbers(file, name, columns.get(name, ())) for name in ("x", "y", "z")])
    return Shape(run.curve["time"][-1] if len(run.curve) else 0.0, points, None)


def nearest(seconds, time, broke):
    i = int(np.argmin(np.abs(seconds - time)))
    return i - 1 if broke is not None and i > 0 and time <= broke < seconds[i] else i


def shapes_of_bag(file, times, broke):
    import rosbag

    with rosbag.Bag(file) as bag:
        topics = bag.get_type_and_topic_info().topics
        shape, state = (next(topic for topic in sorted(topics) if topic.strip("/").endswith(name))
                        for name in (SHAPE, STATE))
        # Stamps run on over all tests of one launch; the state knows both times.
        first = next(bag.read_messages(topics=[state]))
        begin = first.message.header.stamp.to_sec() - first.message.time
        stamps = [entry.timestamp for entry in bag.read_messages(topics=[shape], raw=True)]
        if not stamps:
            raise ValueError("it holds no shape")
        seconds = np.array([stamp.to_sec() for stamp in stamps]) - begin
        chosen = [nearest(seconds, time, broke) for time in times]
        return [shape_of(next(bag.read_messages(topics=[shape], start_time=stamps[i], end_time=stamps[i])).message,
                         float(seconds[i])) for i in chosen]


def shape_of(message, time):
    points = np.array([(point.x, point.y, point.z) for point in message.points])
    return Shape(time, points, np.array(message.tension))
