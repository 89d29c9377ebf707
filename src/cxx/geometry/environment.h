#pragma once
// Every environment variable is read here.

#include <stdlib.h>

namespace pstripack {

/// Its value; null if there is none, and in a program that has rights which its caller has not (setuid,
/// setgid, file capabilities): there the caller shall not name files to write to or programs to start.
inline const char* environment_variable(const char* name) { return secure_getenv(name); }

}  // namespace pstripack
