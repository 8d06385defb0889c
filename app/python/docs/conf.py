"""Settings of Sphinx for the pages about the module. The build passes the version."""

project = "ChainMail"
extensions = ["sphinx.ext.autodoc", "manual_page", "stub_signatures"]
html_theme = "alabaster"
html_theme_options = {"description": "Deformable objects in Python", "page_width": "1080px"}
html_show_copyright = False
html_use_index = True
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True}
nitpicky = False

import sys  # noqa: E402
from pathlib import Path  # noqa: E402

sys.path.insert(0, str(Path(__file__).parent))
