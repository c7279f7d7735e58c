"""knot_utm from Python: one test (run), several specimens (batch), what tests left (read, read_batch), a method many times
over (sweep), the values with which a test produces a measured curve (fit). doc/studies.md and doc/fits.md have examples."""
import importlib
import pkgutil

# The messages of ROS are in the same package, elsewhere on the path: knot_utm.msg is theirs.
__path__ = pkgutil.extend_path(__path__, __name__)

# Which module has a name. It is imported when the name is first used: the messages alone need no pandas.
_MODULES = {"Batch": "runs", "Interrupted": "errors", "Run": "runs", "RunFailed": "errors", "RunWarning": "errors",
            "WrongInput": "errors", "batch": "runs", "fit": "finding", "rank": "rank_command", "read": "runs", "read_batch": "runs",
            "run": "runs", "sweep": "sweeping"}
__all__ = list(_MODULES)


def __getattr__(name):
    if name == "__version__":
        return importlib.import_module(f"{__name__}.tool").package_version()
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_MODULES[name]}"), name)


def __dir__():
    return sorted({*globals(), *_MODULES, "__version__"})
