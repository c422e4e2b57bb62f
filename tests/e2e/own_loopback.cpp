// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// own_loopback COMMAND...: becomes the command, with a loopback of its own. The commands of our
// pages name their ports, so two pages would meet on one loopback. Where the system gives none, the
// command waits until no other one that was started so is running.
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <iterator>
#include <net/if.h>
#include <sched.h>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace {

bool write_to(const char* path, std::string_view text)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool is_written = write(file, text.data(), text.size()) == std::ssize(text);
    close(file);
    return is_written;
}

/// Moves to a network namespace. Users other than root need a user namespace for that.
bool leave_network()
{
    const auto user = std::to_string(geteuid());
    const auto group = std::to_string(getegid());
    if (geteuid() == 0) return unshare(CLONE_NEWNET) == 0;
    return unshare(CLONE_NEWUSER | CLONE_NEWNET) == 0 &&
           write_to("/proc/self/uid_map", user + " " + user + " 1") &&
           write_to("/proc/self/setgroups", "deny") &&
           write_to("/proc/self/gid_map", group + " " + group + " 1");
}

bool start_loopback()
{
    const int any = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    ifreq request{};
    std::strcpy(static_cast<char*>(request.ifr_name), "lo");
    request.ifr_flags = IFF_UP;
    const bool is_up = any >= 0 && ioctl(any, SIOCSIFFLAGS, &request) == 0;
    close(any);
    return is_up;
}

/// Holds until the command and all that it starts have ended: they inherit the file.
bool wait_for_turn()
{
    const int own_program = open("/proc/self/exe", O_RDONLY); // NOLINT: inherited on purpose
    return own_program >= 0 && flock(own_program, LOCK_EX) == 0;
}

} // namespace

int main(int count, char** words)
{
    if (count < 2) {
        std::fputs("usage: own_loopback COMMAND...\n", stderr);
        return 2;
    }
    if (!(leave_network() ? start_loopback() : wait_for_turn())) {
        std::perror("own_loopback");
        return 1;
    }
    execvp(words[1], words + 1);
    std::perror(words[1]);
    return 127;
}
