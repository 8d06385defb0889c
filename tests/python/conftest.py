import os
from pathlib import Path

import pytest


@pytest.fixture
def program():
    """The command line program of the same build."""
    return os.environ["CHAINMAIL_PROGRAM"]


@pytest.fixture
def source():
    """The folder of the sources."""
    return Path(os.environ["CHAINMAIL_SOURCE"])
