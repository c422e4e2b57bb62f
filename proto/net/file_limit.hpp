// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::net {

/// Makes writing beyond the file size limit of the process (ulimit -f) fail with EFBIG, just as a
/// full disk gives ENOSPC, instead of ending the program by SIGXFSZ. Commands that the program
/// starts get the original handling of the signal.
void survive_file_limit();

} // namespace hapnet::net
