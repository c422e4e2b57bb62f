// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::secure::keys {

/// Protects the memory of this process from now on: it leaves no core dump, and no other process of
/// the same user can read it (PR_SET_DUMPABLE). Call it before the first secret is in memory.
void hide_process();

} // namespace hapnet::secure::keys
