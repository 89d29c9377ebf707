#include "parallel/communicator.h"

#include <algorithm>

#include "capi/pstripack.h"
#include "parallel/agreement.h"

namespace pstripack {

Parcels Communicator::all_gather(const void* bytes, std::size_t size) {
  const std::int64_t* const sizes = all_gather_one(static_cast<std::int64_t>(size));
  Parcels all;
  in_agreement(*this, [&] {
    all.begin.resize(static_cast<std::size_t>(this->size()) + 1);
    for (std::size_t r = 0; r + 1 < all.begin.size(); ++r)
      all.begin[r + 1] = all.begin[r] + static_cast<std::size_t>(sizes[r]);
    all.bytes = Block(all.begin.back());
  });
  const auto* const from = static_cast<const unsigned char*>(bytes);
  std::copy(from, from + size, all.bytes.data() + all.begin[static_cast<std::size_t>(rank())]);
  all_gather_in_place(all.bytes.data(), all.begin);
  return all;
}

Parcels SingleProcess::exchange(const Parcels& outgoing, std::int32_t code) {
  if (code != 0) throw AgreedFailure(code);
  return all_gather(outgoing.bytes.data(), outgoing.begin[1]);
}

void SingleProcess::start(const Parcels& outgoing, Parcels& incoming) {
  std::copy_n(outgoing.bytes.data(), outgoing.begin[1], incoming.bytes.data());
}

std::int32_t code_of(const std::exception_ptr& error) {
  try {
    std::rethrow_exception(error);
  } catch (const Failure& failure) {
    return failure.code;
  } catch (const AgreedFailure& failure) {
    return failure.code;
  } catch (...) {
    return PSTRIPACK_OUT_OF_MEMORY;
  }
}

}  // namespace pstripack
