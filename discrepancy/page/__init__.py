"""HTML pages of the loop's results: one file each, opens offline."""

from discrepancy.page.ladder_svg import ladder_picture
from discrepancy.page.write import page_of, write_page

__all__ = ["ladder_picture", "page_of", "write_page"]
