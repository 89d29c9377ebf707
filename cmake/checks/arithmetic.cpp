// What the libraries need of a target. Compiled at configure.
#include <limits>
static_assert(sizeof(void*) == 8 && sizeof(__int128) == 16);
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<float>::is_iec559);
#if !defined(__FLT_EVAL_METHOD__) || __FLT_EVAL_METHOD__ != 0
#error excess precision
#endif
int main() {}
