"""knot_utm from Python: one test (run), what a test left (read), many tests (sweep), the
values with which a test produces a measured curve (fit). doc/studies.md and doc/fits.md have examples."""
import pkgutil

# The messages of ROS are a package of the same name elsewhere on the path: knot_utm.msg is theirs.
__path__ = pkgutil.extend_path(__path__, __name__)

from knot_utm.errors import Interrupted, WrongInput
from knot_utm.finding import fit
from knot_utm.runs import Run, read, run
from knot_utm.sweeping import sweep

__all__ = ["Interrupted", "Run", "WrongInput", "fit", "read", "run", "sweep"]
