"""What ends a report, an export or a movie: one line, for a person."""
import contextlib
import sys


class CannotReport(Exception):
    pass


@contextlib.contextmanager
def in_one_line(program, packages):
    """Ends the program with exit code 1 and one line, whatever goes wrong. `packages`: Debian's, by the module."""
    try:
        yield
    except ModuleNotFoundError as missing:
        package = packages.get((missing.name or "").split(".")[0])
        sys.exit(f"{program}: {missing}" + (f": install Debian's package {package}" if package else ""))
    except KeyboardInterrupt:
        sys.exit(f"{program}: interrupted")
    except Exception as error:
        said = " ".join(str(error).split())
        sys.exit(f"{program}: " + (said if isinstance(error, CannotReport) else f"{type(error).__name__}: {said}"))
