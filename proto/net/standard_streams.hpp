// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::net {

/// First thing in every main(): puts /dev/null at each of the descriptors 0, 1 and 2 that the
/// program was started without. Otherwise the next file or socket to be opened takes the number,
/// and text for a person goes into it. Reading and writing there fail, as they did before.
void fill_standard_streams();

} // namespace hapnet::net
