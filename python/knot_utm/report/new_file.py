"""Whether a file that a user names may be written."""
import os
import stat


def files_of(folder):
    """All files that stand in a folder: a run is read from several."""
    return [os.path.join(folder, name) for name in os.listdir(folder)] if os.path.isdir(folder) else []


def why_not(file, inputs, overwrite):
    """A sentence on why the file must not be written; None where it may be. A link to an input is the input."""
    if not os.path.lexists(file):
        return None
    if os.path.exists(file):
        if any(os.path.exists(one) and os.path.samefile(file, one) for one in inputs):
            return f"{file} is an input, and would be written over: give another name"
        mode = os.stat(file).st_mode
        if stat.S_ISCHR(mode) or stat.S_ISFIFO(mode):
            return None
    return None if overwrite else f"{file} exists already: give another name, or --overwrite"
