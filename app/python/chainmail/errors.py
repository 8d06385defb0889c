"""The exceptions of the package."""

__all__ = ["Cancelled", "Error"]


class Error(ValueError):
    """Raised for bad input: arguments, files and objects that a method cannot work on.

    Its text is one sentence, the same as on the command line: where it happened, what is wrong, and what to do.
    Nothing has changed when it is raised.
    """

    where: str
    """The argument, element or file that is wrong."""
    problem: str
    """What is wrong with it."""
    remedy: str
    """What to do about it."""

    def __init__(self, where: str, problem: str, remedy: str) -> None:
        super().__init__(where, problem, remedy)  # the arguments, with which pickle makes it again
        self.where = where
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        return f"{self.where}: {self.problem}; {self.remedy}"


class Cancelled(Exception):
    """Raised by work that was cancelled (see Job). It is not an Error: nothing is wrong, and there is no result."""
