#include "mpi/roll_call.h"

#include <signal.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <new>

#include "base/system.h"
#include "mpi/area_of_all.h"

namespace pstripack {
namespace {

struct Entry {
  pid_t process;
  int rank;
  volatile sig_atomic_t ending;  ///< the rank has got the signal itself, or could not note it: it is not lost
  char phase[48];                ///< empty: not in a collective call
};

struct Page {
  explicit Page(int n) : count(n) {}
  std::atomic<int> told{0};
  int count;
  Entry* entry() { return reinterpret_cast<Entry*>(this + 1); }
};

/// The pages of this process, one per communicator.
constexpr int kPages = 16;
std::atomic<Page*> pages[kPages];
Entry* my_entry[kPages];

// The following functions run in a signal handler: they use system calls and the stack only.

void tell(const Entry& lost) {
  char line[128] = "pstripack: rank ";
  char* at = line + strlen(line);
  char digits[12];
  int n = 0, rank = lost.rank;
  do digits[n++] = static_cast<char>('0' + rank % 10);
  while ((rank /= 10) > 0);
  while (n > 0) *at++ = digits[--n];
  strcpy(at, " was lost during ");
  if (lost.phase[0] != '\0')
    strncat(line, lost.phase, sizeof lost.phase - 1);
  else
    strcat(line, "its own work");
  strcat(line, "; the job ends\n");
  if (write(STDERR_FILENO, line, strlen(line)) < 0) return;
}

/// The handler of SIGTERM: reports a lost rank, then ends this process by the signal.
void answer(int signal) {
  for (int k = 0; k < kPages; ++k)
    if (pages[k].load() != nullptr) my_entry[k]->ending = 1;
  for (int k = 0; k < kPages; ++k) {
    Page* const page = pages[k].load();
    for (int i = 0; page != nullptr && i < page->count; ++i) {
      const Entry& e = page->entry()[i];
      const bool matters = e.phase[0] != '\0' || my_entry[k]->phase[0] != '\0';
      // Test is_gone before `ending`: a rank that gets the signal sets `ending` before it ends.
      if (matters && e.process > 0 && is_gone(e.process) && !e.ending && page->told.exchange(1) == 0) tell(e);
    }
  }
  ::signal(signal, SIG_DFL);
  raise(signal);
}

bool is_answered_by(void (*handler)(int)) {
  struct sigaction now {};
  return sigaction(SIGTERM, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 &&
         now.sa_handler == handler;
}

void let_answer(void (*handler)(int)) {
  struct sigaction next {};
  next.sa_handler = handler;
  sigaction(SIGTERM, &next, nullptr);
}

}  // namespace

RollCall::RollCall(MPI_Comm comm) : slot_(kPages) {
  MPI_Comm machine;
  int rank = 0, mine = 0, count = 1;
  MPI_Comm_rank(comm, &rank);
  if (MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &machine) != MPI_SUCCESS) return;
  MPI_Comm_rank(machine, &mine);
  MPI_Comm_size(machine, &count);
  me_ = static_cast<std::size_t>(mine);
  if (count > 1) {
    area_ = area_of_all(machine, sizeof(Page) + static_cast<std::size_t>(count) * sizeof(Entry));
    if (mine == 0 && area_.data() != nullptr) new (area_.data()) Page(count);
    MPI_Barrier(machine);
    if (area_.data() != nullptr) take_place(rank);
  }
  MPI_Comm_free(&machine);
}

void RollCall::take_place(int rank) {
  Page* const page = static_cast<Page*>(area_.data());
  Entry& e = page->entry()[me_];
  e.process = getpid();
  e.rank = rank;
  e.ending = 1;
  if (!is_answered_by(SIG_DFL) && !is_answered_by(answer)) return;  // the program has its own handler
  for (slot_ = 0; slot_ < kPages && pages[slot_].load() != nullptr;) ++slot_;
  if (slot_ == kPages) return;
  my_entry[slot_] = &e;
  pages[slot_] = page;
  e.ending = 0;
  if (is_answered_by(SIG_DFL)) let_answer(answer);
}

RollCall::~RollCall() {
  if (slot_ == kPages) return;
  my_entry[slot_]->ending = 1;
  pages[slot_] = nullptr;
  for (const auto& page : pages)
    if (page.load() != nullptr) return;
  if (is_answered_by(answer)) let_answer(SIG_DFL);
}

void RollCall::set_phase(const char* phase) {
  if (area_.data() == nullptr) return;
  strncpy(static_cast<Page*>(area_.data())->entry()[me_].phase, phase, sizeof(Entry::phase) - 1);
}

}  // namespace pstripack
