// A library that forgot the line that registers its method.

extern "C" int pcrbTestNothing() { return 0; }
