#include "mpm/transfer.h"

#include <string>

#include "material/kernels.h"

namespace furrow {

const TransferKernels& transfer_kernels() {
#ifdef FURROW_X86_KERNELS
  const std::string set = kernels().instruction_set;
  if (set == "avx512") return transfer_kernels_avx512();
  if (set == "avx2") return transfer_kernels_avx2();
#endif
  return transfer_kernels_baseline();
}

}  // namespace furrow
