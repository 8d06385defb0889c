// Loaded before the tests under the address sanitizer: libraries stay loaded to the end, so that a leak in a
// graphics driver, which is unloaded before leaks are looked for, still has the name that lsan.supp knows.
extern "C" int dlclose(void*) { return 0; }
