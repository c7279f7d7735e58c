"""Processes of tensile_test, some at a time, until all have ended or they are stopped."""
from concurrent.futures import ThreadPoolExecutor, as_completed

from tqdm import tqdm

from knot_utm import tool
from knot_utm.errors import Interrupted


class Runner:
    def __init__(self):
        self.stopped = None  # why
        self._live = set()

    def stop(self, why):
        """No run begins any more, and those in flight are lost."""
        self.stopped = self.stopped or why
        for process in list(self._live):
            process.kill()

    def each(self, do, points, jobs, what):
        """`do(*point)` for all points, some at a time; what each returned, in their order."""
        with ThreadPoolExecutor(jobs) as pool, tqdm(total=len(points), desc=what, unit="run", disable=None) as bar:
            futures = [pool.submit(do, *point) for point in points]
            try:
                for future in as_completed(futures):
                    future.result()
                    bar.update()
            except BaseException as error:
                self.stop("it was interrupted" if isinstance(error, KeyboardInterrupt) else str(error))
                raise Interrupted(self.stopped) if isinstance(error, KeyboardInterrupt) else error
            return [future.result() for future in futures]

    def wait(self, method, settings, out, *more):
        """(exit code, the last line that it said) of a run that goes on to its end or until it is stopped."""
        process = tool.start(method, settings, out, *more)
        self._live.add(process)
        if self.stopped:  # between the question and the start
            process.kill()
        _, stderr = process.communicate()
        self._live.discard(process)
        return process.returncode, tool.said_by(stderr)
