// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <grp.h>
#include <optional>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hapnet::test {

/// Another user of the machine: nothing else has this number. Only root can give files to it, or be
/// it.
inline constexpr uid_t another_user = 47'110;

inline bool is_root() { return geteuid() == 0; }

/// Returns the result of `work`, 0 to 255, in a child process of that user; nullopt on failure.
template <typename Work>
std::optional<int> as_user(uid_t user, const Work& work)
{
    const pid_t child = fork();
    if (child == 0) {
        const bool is_user = setgroups(0, nullptr) == 0 && setresgid(user, user, user) == 0 &&
                             setresuid(user, user, user) == 0;
        _exit(is_user ? work() : 255);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return std::nullopt;
    return WEXITSTATUS(status);
}

} // namespace hapnet::test
