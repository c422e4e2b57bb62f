// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/standard_streams.hpp"

#include <fcntl.h>
#include <initializer_list>
#include <unistd.h>

namespace hapnet::net {

void fill_standard_streams()
{
    // The order matters: open() takes the lowest number that is free.
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(descriptor, F_GETFD) >= 0) continue;
        // It is opened for the wrong direction, so that a program that prints gets an error.
        const int opened = open(
            "/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY); // NOLINT(*-cloexec)
        if (opened >= 0 && opened != descriptor) close(opened);
    }
}

} // namespace hapnet::net
