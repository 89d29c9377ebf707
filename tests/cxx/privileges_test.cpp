// A program with rights that its caller lacks (setuid, setgid) ignores the library's variables in the
// caller's environment. Run by root: a copy of this program, started by another user.

#include <fcntl.h>
#include <poll.h>
#include <sys/auxv.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstddef>
#include <cstdio>

#include "support/this_program.h"

namespace {

constexpr uid_t kAnother = 65534;

/// A socket like that of a pool; accepts a connection only when asked.
class Listener {
 public:
  Listener()
      : name_("pstripack-test-" + std::to_string(getpid())), socket_(socket(AF_UNIX, SOCK_SEQPACKET, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name_.copy(address.sun_path + 1, sizeof address.sun_path - 1);
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name_.size());
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
  }
  ~Listener() { close(socket_); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  const std::string& name() const { return name_; }
  bool has_been_asked() const {
    pollfd event{socket_, POLLIN, 0};
    return poll(&event, 1, 0) == 1;
  }

 private:
  std::string name_;
  int socket_;
};

/// The effects of a program of mode `mode`, owned by root, when another user starts it with all variables
/// set.
struct Effects {
  int code;
  bool is_privileged, has_report, has_recording, has_warned, has_connected, has_started_a_program;
};

Effects effects(mode_t mode) {
  const Folder folder;
  const std::string theirs = folder.path() + "/theirs", copy = folder.path() + "/copy";
  char self[4096] = "";
  EXPECT_GT(readlink("/proc/self/exe", self, sizeof self - 1), 0);
  EXPECT_EQ(std::system(("cp '" + std::string(self) + "' " + copy).c_str()), 0);
  EXPECT_EQ(chmod(copy.c_str(), mode), 0);
  EXPECT_EQ(chmod(folder.path().c_str(), 0755), 0);
  EXPECT_EQ(mkdir(theirs.c_str(), 0755), 0);
  EXPECT_EQ(chown(theirs.c_str(), kAnother, kAnother), 0);
  std::ofstream(theirs + "/program") << "#!/bin/sh\ncat > /dev/null\n: > " << theirs << "/started\n";
  EXPECT_EQ(chmod((theirs + "/program").c_str(), 0755), 0);

  const auto run = [&](const std::string& environment) {
    const std::string another = std::to_string(kAnother);
    const int status =
        std::system(("cd " + folder.path() + " && exec > out 2>> err && setpriv --reuid " + another +
                     " --regid " + another + " --clear-groups env OMP_NUM_THREADS=1 " + environment +
                     " timeout 60 " + copy + " --as call")
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const Listener listener;
  const auto exists = [&](const std::string& file) {
    return access((theirs + "/" + file).c_str(), F_OK) == 0;
  };
  const int first =
      run("PSTRIPACK_REPORT=" + theirs + "/report PSTRIPACK_CHECK=" + theirs +
          "/calls PSTRIPACK_ORDER=nonsense PSTRIPACK_POOL_MIN_NODES=3 PSTRIPACK_POOL=" + listener.name());
  const int second = run("PSTRIPACK_CHECK=lib:/no/such/library PSTRIPACK_COMPARE=" + theirs + "/program");
  return {first != 0 ? first : second,
          contents(folder.path() + "/out") == "privileged\n",
          exists("report"),
          exists("calls"),
          contents(folder.path() + "/err").find("nonsense") != std::string::npos,
          listener.has_been_asked(),
          exists("started")};
}

class Environment : public ::testing::TestWithParam<mode_t> {};

TEST_P(Environment, IsHeededOnlyInAProgramWithoutPrivileges) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can start programs as another user";
  const Effects seen = effects(GetParam());
  EXPECT_EQ(seen.code, 0);
  const bool heeds = GetParam() == 0755;
  if (heeds)
    EXPECT_FALSE(seen.is_privileged);
  else if (!seen.is_privileged)
    GTEST_SKIP() << "set-user-ID and set-group-ID have no effect in /tmp";
  for (const bool effect :
       {seen.has_report, seen.has_recording, seen.has_warned, seen.has_connected, seen.has_started_a_program})
    EXPECT_EQ(effect, heeds);
}

INSTANTIATE_TEST_SUITE_P(OfMode, Environment,
                         ::testing::Values(0755, 04755, 02755));  // plain, setuid, setgid

int run_as(const std::string&, const std::string&, std::size_t, int) {
  std::puts(getauxval(AT_SECURE) != 0 ? "privileged" : "plain");
  call_trmesh(point_sets::make("random", 1000));
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return run_as_or_test(argc, argv, run_as); }
