"""What mends a finding that one column is taken for the wrong thing: in words of the command line, or of a page that has the control."""

from dataclasses import dataclass

# Roles by which angles are told apart, as a page names them.
TITLES = {"angle": "angle of the output", "input_angle": "angle of the input (motor)"}


@dataclass(frozen=True)
class OfColumn:
    """The column that a finding is about, as its file names it; ``role``: the one that it should have instead, empty where that is not plain."""

    column: str
    role: str = ""

    def remedy(self, on_page: bool = False) -> str:
        """What to do where the role is plain: of a command, or ``on_page`` of the control."""
        title = TITLES[self.role]
        if on_page:
            return f"choose {title} as the role of column {self.column}"
        return f"the {title.partition(' (')[0]} is columns.{self.role} (--column '{self.role}={self.column}')"
