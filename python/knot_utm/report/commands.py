"""What the commands of reports have in common: how they begin, read their words, and end."""
import argparse
import contextlib
import importlib
import os
import stat
import sys
import tempfile

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput


@contextlib.contextmanager
def in_one_line(program, goes_on=False):
    """Ends the program with a line, whatever goes wrong: with exit code 2 for bad input, else with 1. `goes_on`: whether the same
    command goes on where the work was cut off."""
    again = "; the same command goes on" if goes_on else ""
    try:
        yield
    except WrongInput as wrong:
        refuse(program, wrong)
    except KeyboardInterrupt:
        refuse(program, "it was interrupted", 1)
    except Interrupted as error:
        refuse(program, f"{error}{again}", 1)
    except ModuleNotFoundError as missing:
        name = (missing.name or "").split(".")[0].lower()
        refuse(program, f"{missing}: install Debian's package {name if name == 'weasyprint' else 'python3-' + name}", 1)
    except OSError as error:
        why = f"{error.filename}: {error.strerror.lower()}" if error.filename else str(error)
        refuse(program, why + again * tool.is_of_a_full_disk(why), 1)
    except Exception as error:
        said = " ".join(str(error).split())
        refuse(program, said if isinstance(error, RuntimeError) else f"{type(error).__name__}: {said}", 1)


class OneLineParser(argparse.ArgumentParser):
    """Refuses words in a line, which says where all of them are told."""

    def error(self, message):
        if not self.add_help:
            message += f" ({self.prog} --help)" if tool.IN_SOURCES else f" ({' '.join(self.format_usage().split())})"
        refuse(self.prog, message)

    def require_room(self, option, file, inputs, overwrite):
        """Refuses a file that must not be written. `inputs`: files and folders that are read."""
        files = [file for one in inputs for file in (os.scandir(one) if os.path.isdir(one) else [one])]
        if why := why_not(file, files, overwrite):
            self.error(f"{option}: {why}")


def refuse(program, message, code=2):
    """Says in a line why the program ends, and ends it; unless given for bad input."""
    print(f"{os.path.basename(program)}:", str(message).encode("utf-8", "backslashreplace").decode("utf-8"), file=sys.stderr)
    sys.exit(code)


def test_in(folder):
    """The folder of a test, as a type of argparse."""
    if not os.path.isdir(folder):
        raise argparse.ArgumentTypeError(f"{folder}: no such folder")
    if not os.path.exists(os.path.join(folder, "method.yaml")):
        raise argparse.ArgumentTypeError(f"{folder}: no test is there (method.yaml)")
    return folder


def file_ending(end):
    """The name of a file that is to be written, as a type of argparse."""
    def checked(name):
        if not name.endswith(end):
            raise argparse.ArgumentTypeError(f"{name}: the name of the file must end with {end}")
        return name
    return checked


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
        importlib.import_module(f"knot_utm.report.{program}").main()


if __name__ == "__main__":  # scripts/PROGRAM WORD...
    from knot_utm.report import commands  # this module again, under the name by which all others know it

    commands.start(sys.argv.pop(1))
