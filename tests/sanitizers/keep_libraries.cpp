// Loaded before the tests with the address sanitizer. It keeps all libraries loaded. Otherwise a graphics driver is
// unloaded before the leak check, and lsan.supp cannot match its name.
extern "C" int dlclose(void*) { return 0; }
