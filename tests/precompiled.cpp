// Nothing is here: this file only makes the precompiled header of the tests.
