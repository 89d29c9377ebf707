#include "parallel/agreement.h"

#include "mesh/delaunay.h"

namespace pstripack {
namespace {

// Greater than the code of any failure that can end the same body: the minimum is then the failure.
constexpr std::int32_t kHidden = -1, kDoNotPay = -2;

}  // namespace

std::int32_t Outcome::code_of_current() {
  try {
    throw;
  } catch (const HiddenNode&) {
    return kHidden;
  } catch (const PatchesDoNotPay&) {
    return kDoNotPay;
  } catch (...) {
    return code_of(std::current_exception());
  }
}

void Outcome::accept() const {
  if (code_ == kHidden) throw HiddenNode{};
  if (code_ == kDoNotPay) throw PatchesDoNotPay{};
  if (code_ != 0) throw AgreedFailure(code_);
}

}  // namespace pstripack
