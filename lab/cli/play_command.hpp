// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::lab {

/// Plays one session in virtual time: to its end, for its numbers, or with a control socket for
/// whoever watches it, until it is stopped. The exit code. The error: bad input. Throws
/// std::system_error when a socket or a file cannot be made.
[[nodiscard]] base::Result<int> play_session(const PlayCommand& command);

} // namespace hapnet::lab
