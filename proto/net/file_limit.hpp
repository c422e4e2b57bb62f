// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::net {

/// From this call on, writing a file beyond the limit of the process (ulimit -f) fails with EFBIG,
/// as it would with ENOSPC on a full disk. Before, SIGXFSZ ended the program. Commands that the
/// program starts have the signal as it was.
void survive_file_limit();

} // namespace hapnet::net
