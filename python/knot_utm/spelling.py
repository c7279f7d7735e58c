"""The end of a message about a word that is not known."""
import difflib


def hint(word, known):
    """"; did you mean WORD?" of the known word that is spelt nearly so; empty where there is none."""
    near = difflib.get_close_matches(str(word), list(known), 1)
    return f"; did you mean {near[0]}?" if near else ""
