#include "parallel/agreement.h"

#include "mesh/delaunay.h"

namespace pstripack {
namespace {

// Above the codes of all failures that may end where a hidden node may.
constexpr std::int32_t kHidden = -1;

}  // namespace

std::int32_t Outcome::code_of_current() {
  try {
    throw;
  } catch (const HiddenNode&) {
    return kHidden;
  } catch (...) {
    return code_of(std::current_exception());
  }
}

void Outcome::accept() const {
  if (code_ == kHidden) throw HiddenNode{};
  if (code_ != 0) throw AgreedFailure(code_);
}

}  // namespace pstripack
