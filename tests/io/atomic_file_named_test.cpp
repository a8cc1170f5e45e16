// SPDX-License-Identifier: MIT
// The same where the system has no files without names.
#if __has_include(<fcntl.h>)
#include <fcntl.h>
#undef O_TMPFILE
#endif

#include "atomic_file_test.cpp"
