// Keeps libraries loaded to the end, so that the leak sanitizer can tell who owns what they leak: OpenGL closes its
// driver before the program ends, and what the driver leaks would be nobody's. The preset `asan` links this in.
extern "C" int dlclose(void* /*library*/) {
    return 0;
}
