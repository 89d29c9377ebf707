#include "parallel/agreement.h"

#include "mesh/delaunay.h"

namespace pstripack {
namespace {

// Votes, no result codes. The failure with result code c is kFailure + c, so that the minimum is a failure.
constexpr std::int32_t kHidden = -1, kDoNotPay = -2, kFailure = -(1 << 30);

}  // namespace

std::int32_t Outcome::code_of_current() {
  try {
    throw;
  } catch (const HiddenNode&) {
    return kHidden;
  } catch (const PatchesDoNotPay&) {
    return kDoNotPay;
  } catch (...) {
    return kFailure + code_of(std::current_exception());
  }
}

void Outcome::accept() const {
  if (code_ == kHidden) throw HiddenNode{};
  if (code_ == kDoNotPay) throw PatchesDoNotPay{};
  // A communicator that has failed itself passes a result code, -6.
  if (code_ != 0) throw AgreedFailure(code_ < kFailure / 2 ? code_ - kFailure : code_);
}

}  // namespace pstripack
