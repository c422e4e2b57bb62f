// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/file_limit.hpp"

#include <csignal>

namespace hapnet::net {

void survive_file_limit()
{
    struct sigaction before {};
    // If the program ignores the signal already, no change is needed, also not for the commands
    // that it starts.
    if (sigaction(SIGXFSZ, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) return;
    struct sigaction nothing {};
    nothing.sa_handler = [](int) {}; // unlike SIG_IGN, a handler ends with exec()
    sigemptyset(&nothing.sa_mask);
    nothing.sa_flags = SA_RESTART;
    sigaction(SIGXFSZ, &nothing, nullptr);
}

} // namespace hapnet::net
