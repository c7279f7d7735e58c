"""What the commands of reports have in common: how they begin, read their words, and end."""
import argparse
import contextlib
import gc
import importlib
import os
import stat
import sys
import tempfile

from knot_utm import tool
from knot_utm.errors import WrongInput

# Debian's name of what a module is in.
PACKAGES = {"matplotlib": "python3-matplotlib", "numpy": "python3-numpy", "yaml": "python3-yaml", "scipy": "python3-scipy",
            "jinja2": "python3-jinja2", "weasyprint": "weasyprint"}


class CannotReport(Exception):
    pass


@contextlib.contextmanager
def in_one_line(program):
    """Ends the program with exit code 1 and one line, whatever goes wrong."""
    try:
        yield
    except ModuleNotFoundError as missing:
        package = PACKAGES.get((missing.name or "").split(".")[0])
        sys.exit(f"{program}: {missing}" + (f": install Debian's package {package}" if package else ""))
    except KeyboardInterrupt:
        sys.exit(f"{program}: interrupted")
    except Exception as error:
        said = " ".join(str(error).split())
        sys.exit(f"{program}: " + (said if isinstance(error, (CannotReport, WrongInput)) else f"{type(error).__name__}: {said}"))


class OneLineParser(argparse.ArgumentParser):
    """Refuses words in a line, which says where all of them are told."""

    def error(self, message):
        if not self.add_help:
            message += f" ({self.prog} --help)" if tool.IN_SOURCES else f" ({' '.join(self.format_usage().split())})"
        refuse(os.path.basename(self.prog), message)


def refuse(program, message):
    """Bad input."""
    print(f"{program}:", str(message).encode("utf-8", "backslashreplace").decode("utf-8"), file=sys.stderr)
    sys.exit(2)


def files_of(folder):
    """All files that stand in a folder: a run is read from several."""
    return [os.path.join(folder, name) for name in os.listdir(folder)] if os.path.isdir(folder) else []


def why_no_test(folder):
    """A sentence on why a folder holds no test; None where it holds one."""
    if not os.path.isdir(folder):
        return f"{folder}: no such folder"
    return None if os.path.exists(os.path.join(folder, "method.yaml")) else f"{folder}: no test is there (method.yaml)"


def why_not(file, inputs, overwrite):
    """A sentence on why the file must not or cannot be written; None where it may be. A link to an input is the input."""
    if not os.path.lexists(file):
        try:
            with tempfile.TemporaryFile(dir=os.path.dirname(file) or "."):
                return None
        except OSError as error:
            return f"cannot write {file}: {error.strerror.lower()}"
    if os.path.exists(file):
        if any(os.path.exists(one) and os.path.samefile(file, one) for one in inputs):
            return f"{file} is an input, and would be written over: give another name"
        mode = os.stat(file).st_mode
        if stat.S_ISCHR(mode) or stat.S_ISFIFO(mode):
            return None
    return None if overwrite else f"{file} exists already: give another name, or --overwrite"


def start(program):
    """One of them, by the name of its module. What that needs may not be installed, which is told in a line, too."""
    with in_one_line(program):
        gc.disable()
        module = importlib.import_module(f"knot_utm.report.{program}")
        gc.freeze()  # all that is imported stays, and no search for garbage looks at it
        gc.enable()
        module.main()


if __name__ == "__main__":  # scripts/PROGRAM WORD...
    from knot_utm.report import commands  # this module again, under the name by which all others know it

    commands.start(sys.argv.pop(1))
