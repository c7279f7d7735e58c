"""What ends a report: one line, for a person."""


class CannotReport(Exception):
    pass
