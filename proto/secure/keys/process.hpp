// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::secure::keys {

/// Before the first secret is in memory: from now on this process leaves no core dump, and no other
/// process of the same user may look into it (PR_SET_DUMPABLE).
void hide_process();

} // namespace hapnet::secure::keys
