// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/time.hpp"

using namespace hapnet::base;

#ifdef MUST_COMPILE
constexpr auto now = Timeline::time_point{};
#else
const auto now = Timeline::now();
#endif
