#pragma once
// What libpstripack_mpi asks of libpstripack. Not part of the public interface.

#include "capi/pstripack.h"
#include "observe/report.h"
#include "trmesh/engine.h"

extern "C" {

/// Sets the engine that is asked first, null for none; returns the one before.
PSTRIPACK_API pstripack_trmesh_engine pstripack_set_trmesh_engine(pstripack_trmesh_engine engine);

/// Is a report asked for?
PSTRIPACK_API int pstripack_report_is_wanted(void);
/// Writes the line and adds the call to the table. Changes nothing that the program can see, not even errno.
PSTRIPACK_API void pstripack_add_to_report(const pstripack::CallReport* call);

/// In comm mode rank 0 writes the calls, which are the same on all ranks: 1 on the others, 0 to end it.
PSTRIPACK_API void pstripack_leave_check_to_another_rank(int leave);
}
