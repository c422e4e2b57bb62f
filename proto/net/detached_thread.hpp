// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace hapnet::net {

/// Starts a thread that is never joined, for work that may block forever, such as writing to a pipe
/// without a reader. `work` must own everything it uses, because the thread may run until the
/// process ends. The stack is small, because it may be locked into memory. Throws
/// std::system_error.
void start_detached(std::function<void()> work);

} // namespace hapnet::net
