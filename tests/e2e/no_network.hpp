// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

namespace hapnet::e2e {

/// No network at all, not even a running loopback, for programs started meanwhile. Needs root.
class NoNetwork {
public:
    NoNetwork() : before_{open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC)}
    {
        in_force_ = before_ >= 0 && unshare(CLONE_NEWNET) == 0;
    }
    ~NoNetwork()
    {
        if (in_force_) base::ensure(setns(before_, CLONE_NEWNET) == 0);
        if (before_ >= 0) close(before_);
    }
    NoNetwork(const NoNetwork&) = delete;
    NoNetwork& operator=(const NoNetwork&) = delete;

    [[nodiscard]] bool in_force() const { return in_force_; }

private:
    int before_;
    bool in_force_ = false;
};

} // namespace hapnet::e2e
