// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/text.hpp"

using namespace hapnet::base;

#ifdef MUST_COMPILE
auto parse() { return parse_duration("160ms"); }
#else
void parse() { parse_duration("160ms"); }
#endif
