// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/exit_guard.hpp"

#include "proto/net/crash_signal.hpp"
#include "proto/net/program.hpp"

#include <array>
#include <atomic>
#include <cstdlib>
#include <dlfcn.h>
#include <execinfo.h>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

/// It must be global, because a handler of exit() has no argument.
std::atomic<const ExitGuard*> guard_of_exit{nullptr};

/// Returns the loaded object that contains an address; nullptr if none is known.
const void* object_at(const void* address)
{
    Dl_info info{};
    return dladdr(address, &info) != 0 ? info.dli_fbase : nullptr;
}

/// Returns the file of the code that has called exit(); "" if it cannot be determined. The
/// innermost calls are those of this program's handler and of the C library that calls it.
std::string caller_of_exit()
{
    std::array<void*, 32> calls{};
    const int count = backtrace(calls.data(), static_cast<int>(calls.size()));
    const void* const own = object_at(reinterpret_cast<const void*>(&caller_of_exit));
    const void* const library = object_at(dlsym(RTLD_DEFAULT, "exit"));
    bool is_in_library = false;
    for (int i = 0; i < count; ++i) {
        void* const call = calls.at(static_cast<std::size_t>(i));
        const void* const object = object_at(call);
        if (object == library) is_in_library = true;
        if (!is_in_library || object == library) continue;
        Dl_info info{};
        const bool is_known = object != own && dladdr(call, &info) != 0;
        return is_known && info.dli_fname != nullptr ? info.dli_fname : "";
    }
    return {};
}

/// Prints one line on stderr, unless that would block because its reader hangs.
void say_last(std::string_view program, std::string_view text)
{
    const auto line = fmt::format("{}: {}\n", program, text);
    constexpr int patience_ms = 20;
    pollfd out{STDERR_FILENO, POLLOUT, 0};
    if (poll(&out, 1, patience_ms) > 0)
        std::ignore = write(STDERR_FILENO, line.data(), line.size());
}

void on_exit_called()
{
    const ExitGuard* const guard = guard_of_exit.exchange(nullptr);
    if (guard == nullptr) return; // a regular end of the program
    CrashSignal::hold_to_the_end();
    const auto file = caller_of_exit();
    say_last(
        guard->program(),
        fmt::format("{} has called exit() in the middle of the run, which has failed: functions "
                    "that this program loads have to return (hapnet/algorithm.h)",
                    file.empty() ? "code that was loaded" : file));
    _exit(exit_failed);
}

} // namespace

ExitGuard::ExitGuard(std::string_view program) : program_{program}
{
    static const bool is_registered = [] {
        return std::atexit(on_exit_called) == 0 && std::at_quick_exit(on_exit_called) == 0;
    }();
    std::ignore = is_registered;
    guard_of_exit = this;
}

ExitGuard::~ExitGuard() { guard_of_exit = nullptr; }

} // namespace hapnet::net
