// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a program (LD_PRELOAD), counts the system calls by which it changes files below a
// folder, and lets the N-th of them go wrong. A filter of the kernel (seccomp) sends these calls
// here, so that those are among them that the C library makes for itself (fopen, fclose ...), which
// a preloaded `write` never sees. x86-64 Linux.
//
//   FAULT_FOLDER  only files below this folder count (absolute, no symbolic links in it)
//   FAULT_LOG     gets a line "NAME PATH" for each call that counts
//   FAULT_AT      the number of the call, from 1; without it nothing goes wrong
//   FAULT         kill_before, kill_after: SIGKILL before or after the call
//                 enospc: the call fails with "No space left on device"; full: and all after it
//                 eintr: the call fails with "Interrupted system call"; short: half is written
//
// A call to which that cannot happen (no rename is ever interrupted) is made as it is.
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace {

enum class Names { kFile, kPath, kPathAt };  ///< what the first argument, or the second, is

struct Call {
  const char* name;
  long number;
  Names names;
  bool can_fill;       ///< ENOSPC
  bool can_interrupt;  ///< EINTR
};

constexpr std::array kCalls{
    Call{"open", SYS_open, Names::kPath, true, true},
    Call{"openat", SYS_openat, Names::kPathAt, true, true},
    Call{"write", SYS_write, Names::kFile, true, true},
    Call{"pwrite", SYS_pwrite64, Names::kFile, true, true},
    Call{"writev", SYS_writev, Names::kFile, true, true},
    Call{"close", SYS_close, Names::kFile, true, true},
    Call{"fsync", SYS_fsync, Names::kFile, true, true},
    Call{"fdatasync", SYS_fdatasync, Names::kFile, true, true},
    Call{"truncate", SYS_truncate, Names::kPath, false, true},
    Call{"ftruncate", SYS_ftruncate, Names::kFile, false, true},
    Call{"rename", SYS_rename, Names::kPath, true, false},
    Call{"renameat", SYS_renameat, Names::kPathAt, true, false},
    Call{"renameat2", SYS_renameat2, Names::kPathAt, true, false},
    Call{"mkdir", SYS_mkdir, Names::kPath, true, false},
    Call{"mkdirat", SYS_mkdirat, Names::kPathAt, true, false},
    Call{"unlink", SYS_unlink, Names::kPath, false, false},
    Call{"unlinkat", SYS_unlinkat, Names::kPathAt, false, false},
};

/// A sixth argument, of which these calls have none: the filter lets calls with it pass.
constexpr std::uint32_t kPass = 0x70a55e5;

using Arguments = std::array<long, 5>;

/// -errno where it fails, as the kernel says it.
long make(long number, const Arguments& a) {
  const long result = syscall(number, a[0], a[1], a[2], a[3], a[4], static_cast<long>(kPass));
  return result == -1 ? -errno : result;
}

// Set before main, read by the handler, which must not allocate.
char folder[PATH_MAX];
std::string_view fault;
long fault_at = 0;
int log_file = -1;
std::atomic<long> count{0};

const char* text(long argument) { return reinterpret_cast<const char*>(argument); }

/// Of an open file, or of a folder by its descriptor.
bool path_of_file(int descriptor, char* path) {
  char link[40];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size =
      readlink(descriptor == AT_FDCWD ? "/proc/self/cwd" : link, path, PATH_MAX - 1);
  path[size < 0 ? 0 : size] = '\0';
  return size > 0;
}

bool path_of(const Call& call, const Arguments& a, char* path) {
  const int descriptor = call.names == Names::kPath ? AT_FDCWD : static_cast<int>(a[0]);
  if (call.names == Names::kFile) return path_of_file(descriptor, path);
  const char* name = text(a[call.names == Names::kPath ? 0 : 1]);
  path[0] = '\0';
  if (name[0] != '/' && !path_of_file(descriptor, path)) return false;
  const std::size_t size = std::strlen(path);
  const int more = std::snprintf(path + size, PATH_MAX - size, name[0] == '/' ? "%s" : "/%s", name);
  return size + static_cast<std::size_t>(more) < PATH_MAX;
}

bool writes(long flags) { return (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0; }

bool counts(const Call& call, const Arguments& a, const char* path) {
  const std::size_t size = std::strlen(folder);
  if (std::strncmp(path, folder, size) != 0 || (path[size] != '/' && path[size] != '\0'))
    return false;
  if (call.number == SYS_open) return writes(a[1]);
  if (call.number == SYS_openat) return writes(a[2]);
  if (call.number == SYS_close) return writes(fcntl(static_cast<int>(a[0]), F_GETFL));
  return true;
}

void write_log(const Call& call, const char* path) {
  char line[PATH_MAX + 40];
  const int size = std::snprintf(line, sizeof line, "%s %s\n", call.name, path);
  make(SYS_write, {log_file, reinterpret_cast<long>(line), size});
}

/// The first half of the bytes, of `writev` of the first piece that has any.
long write_half(const Call& call, Arguments a) {
  if (call.number == SYS_write || call.number == SYS_pwrite64) {
    a[2] = (a[2] + 1) / 2;
    return make(call.number, a);
  }
  const auto* pieces = reinterpret_cast<const iovec*>(a[1]);
  long i = 0;
  while (i + 1 < a[2] && pieces[i].iov_len == 0) ++i;
  const iovec half{pieces[i].iov_base, (pieces[i].iov_len + 1) / 2};
  return make(SYS_writev, {a[0], reinterpret_cast<long>(&half), 1});
}

/// A file that could not be closed is closed all the same.
long fail(const Call& call, const Arguments& a, int error) {
  if (call.number == SYS_close) make(call.number, a);
  return -error;
}

[[noreturn]] void die() {
  kill(getpid(), SIGKILL);
  for (;;) pause();
}

long make_wrong(const Call& call, const Arguments& a, bool at) {
  const bool is_write =
      call.number == SYS_write || call.number == SYS_pwrite64 || call.number == SYS_writev;
  if (at && fault == "kill_before") die();
  if (at && fault == "kill_after") {
    make(call.number, a);
    die();
  }
  if (call.can_fill && (fault == "full" || (at && fault == "enospc"))) return fail(call, a, ENOSPC);
  if (call.can_interrupt && at && fault == "eintr") return fail(call, a, EINTR);
  if (is_write && at && fault == "short") return write_half(call, a);
  return make(call.number, a);
}

long answer(const Call& call, const Arguments& a) {
  char path[PATH_MAX];
  if (!path_of(call, a, path) || !counts(call, a, path)) return make(call.number, a);
  const long number = ++count;
  write_log(call, path);
  if (fault_at == 0 || number < fault_at) return make(call.number, a);
  return make_wrong(call, a, number == fault_at);
}

void on_call(int, siginfo_t* info, void* context) {
  const int error = errno;
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const Arguments a{registers[REG_RDI], registers[REG_RSI], registers[REG_RDX], registers[REG_R10],
                    registers[REG_R8]};
  for (const Call& call : kCalls)
    if (call.number == info->si_syscall) registers[REG_RAX] = answer(call, a);
  errno = error;
}

[[noreturn]] void give_up(const char* what) {
  std::perror(what);
  std::_Exit(125);
}

/// From now on, in all threads, kCalls go to on_call.
void filter_calls() {
  std::array<sock_filter, kCalls.size() + 5> filter{};
  std::size_t n = 0;
  filter[n++] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[5]));
  filter[n++] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kPass, kCalls.size() + 1, 0);
  filter[n++] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (std::size_t i = 0; i < kCalls.size(); ++i)
    filter[n++] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(kCalls[i].number),
                           static_cast<std::uint8_t>(kCalls.size() - i), 0);
  filter[n++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  filter[n++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP);
  const sock_fprog program{static_cast<unsigned short>(n), filter.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    give_up("inject_fault: no filter of system calls");
}

__attribute__((constructor)) void begin() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
  };
  std::snprintf(folder, sizeof folder, "%s", variable("FAULT_FOLDER"));
  fault = variable("FAULT");
  fault_at = std::atol(variable("FAULT_AT"));
  log_file = open(variable("FAULT_LOG"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (log_file < 0) give_up("inject_fault: FAULT_LOG");
  struct sigaction action {};
  action.sa_sigaction = on_call;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  if (sigaction(SIGSYS, &action, nullptr) != 0) give_up("inject_fault: SIGSYS");
  filter_calls();
}

}  // namespace
