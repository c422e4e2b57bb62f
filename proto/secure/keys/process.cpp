// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/keys/process.hpp"

#include <sys/prctl.h>
#include <tuple>

namespace hapnet::secure::keys {

void hide_process() { std::ignore = ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0); }

} // namespace hapnet::secure::keys
