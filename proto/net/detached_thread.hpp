// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace hapnet::net {

/// Starts a thread that is never joined, for work that may block for ever, such as writing to a
/// pipe that is not read. The thread may run until the process ends, so it owns all that it uses.
/// Its stack is small, as it may be locked into memory. Throws std::system_error.
void start_detached(std::function<void()> work);

} // namespace hapnet::net
