#include <stdint.h>
int32_t c_adds_(const int32_t* n, const int32_t* m, const int64_t* n8, const int64_t* m8) {
  return *n + *m + *n8 + *m8 == 10;
}
