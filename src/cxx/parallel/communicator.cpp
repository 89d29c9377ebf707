#include "parallel/communicator.h"

#include <algorithm>

#include "capi/pstripack.h"

namespace pstripack {

Parcels SingleProcess::all_gather(const void* bytes, std::size_t size) {
  Parcels all{Block(size), {0, size}};
  const auto* const from = static_cast<const unsigned char*>(bytes);
  std::copy(from, from + size, all.bytes.data());
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
