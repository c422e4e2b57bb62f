// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/time.hpp"

using namespace hapnet::base;

constexpr TimePoint start{};

#ifdef MUST_COMPILE
constexpr auto later = start + Duration{1};
#else
constexpr auto later = start + start;
#endif
