"""The words of a roslaunch, for the programs that it starts while it loads a launch file."""
import os

# What scripts/tighten may hand on to roslaunch, and whether a value follows.
OPTIONS = {"-p": True, "--port": True, "-v": False, "--wait": False, "--screen": False, "--log": False,
           "--no-summary": False, "--disable-title": False, "--skip-log-check": False}


def words_of(pid):
    """The command line of a process."""
    try:
        with open(f"/proc/{pid}/cmdline", encoding="utf-8", errors="surrogateescape") as line:
            return line.read().split("\0")[:-1]
    except OSError:
        return []


def loads(words, file):
    """Whether it is this launch file that they name, and no other one that includes it."""
    return any(":=" not in word and os.path.basename(word) == file for word in words)


def without_options(words):
    """Those that are to be arguments."""
    words, found = list(words), []
    while words:
        word = words.pop(0)
        option, joined, _ = word.partition("=")
        if option in OPTIONS:
            if OPTIONS[option] and not joined and words:
                words.pop(0)
        else:
            found.append(word)
    return found


def value_of(words, *names):
    """What follows the last of these, as the next word or behind an equals sign; None: nothing."""
    value = None
    for word, following in zip(words, words[1:] + [None]):
        name, joined, given = word.partition("=")
        if word in names:
            value = following
        elif joined and name in names:
            value = given
        elif word[:2] in names and word[:2] != "--":
            value = word[2:]  # -pPORT
    return value


def argument(words, name, default=""):
    """The value of NAME:=VALUE."""
    begin = name + ":="
    return next((word[len(begin):] for word in reversed(words) if word.startswith(begin)), default)
