// Loading and unloading libpstripack at run time, as VisIt does; with calls from threads in between.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

namespace {

using Trmesh = std::int32_t (*)(std::int32_t, const double*, const double*, const double*, std::int32_t*,
                                std::int32_t*, std::int32_t*, std::int32_t*);

TEST(Dlopen, LoadsCallsAndUnloadsAgainAndAgain) {
  for (int i = 0; i < 20; ++i) {
    void* library = dlopen(PSTRIPACK_LIBRARY, RTLD_NOW | (i % 2 == 0 ? RTLD_LOCAL : RTLD_GLOBAL));
    ASSERT_NE(library, nullptr) << dlerror();
    const auto trmesh = reinterpret_cast<Trmesh>(dlsym(library, "pstripack_trmesh"));
    ASSERT_NE(trmesh, nullptr);
    // Enough nodes for the library to use threads: x, y, z on a spiral.
    const int n = 50000;
    std::vector<double> x(n), y(n), z(n);
    for (int k = 0; k < n; ++k) {
      const double h = 1 - (2.0 * k + 1) / n, r = std::sqrt(1 - h * h);
      x[k] = r * std::cos(2.399963229728653 * k), y[k] = r * std::sin(2.399963229728653 * k), z[k] = h;
    }
    std::vector<std::int32_t> list(6 * n - 12), lptr(6 * n - 12), lend(n);
    std::int32_t lnew = 0, ier = -99;
    std::thread([&] {
      ier = trmesh(n, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew);
    }).join();
    EXPECT_EQ(ier, 0);
    EXPECT_EQ(trmesh(n, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew), 0);
    EXPECT_EQ(lnew, 6 * n - 11);
    EXPECT_EQ(dlclose(library), 0);
  }
}

}  // namespace
