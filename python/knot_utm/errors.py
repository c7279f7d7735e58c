"""What may go wrong, by what its user can do about it."""


class WrongInput(ValueError):
    """A study, a method or a folder cannot be used as it is; the text is one line that says why."""


class Interrupted(RuntimeError):
    """It was cut short, and goes on when it is asked for again; the text is one line that says why."""
