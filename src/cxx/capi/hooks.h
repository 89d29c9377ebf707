#pragma once
// Functions of libpstripack for libpstripack_mpi. Not part of the public interface.

#include "capi/pstripack.h"
#include "observe/report.h"
#include "trmesh/engine.h"

extern "C" {

/// Sets the ranks of a communicator that are asked first whether they take a call; null: none.
PSTRIPACK_API void pstripack_set_trmesh_engine(pstripack::Engine* communicator);

/// 1 if PSTRIPACK_REPORT asks for a report, else 0.
PSTRIPACK_API int pstripack_report_is_wanted(void);
/// Writes the line of the call and adds the call to the table. Does not change errno.
PSTRIPACK_API void pstripack_add_to_report(const pstripack::CallReport* call);

/// In comm mode rank 0 writes the calls, which are the same on all ranks. 1 on the other ranks when comm
/// mode begins, 0 when it ends.
PSTRIPACK_API void pstripack_leave_check_to_another_rank(int leave);
}
