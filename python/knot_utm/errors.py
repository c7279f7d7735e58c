"""What may go wrong, by what its user can do about it."""


class WrongInput(ValueError):
    """A study, a method or a folder cannot be used as it is; the text is one line that says why."""


class RunFailed(RuntimeError):
    """A test ended without what it was to measure: the simulation gave up, the knot came undone before it was pulled, or no
    specimen of a batch counts. The text is one line that says why. `run`: what was measured until then, a Run or a Batch; None
    where nothing was."""

    def __init__(self, why, run=None):
        super().__init__(why)
        self.run = run


class RunWarning(UserWarning):
    """What tensile_test warns of: a test that ended, but whose readings may mislead."""


class Interrupted(RuntimeError):
    """It was cut short, and goes on when it is asked for again; the text is one line that says why."""


def refuse_if(is_wrong, why):
    """Raises WrongInput with a line that says why, where something is wrong."""
    if is_wrong:
        raise WrongInput(why)
