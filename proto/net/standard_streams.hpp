// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::net {

/// Opens /dev/null at each of the descriptors 0, 1 and 2 that the program was started without. Call
/// this first in every main(). Otherwise the next file or socket would get the number, and receive
/// text for people. Reading and writing there fail, as they did before.
void fill_standard_streams();

} // namespace hapnet::net
