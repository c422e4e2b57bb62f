// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/probability.hpp"

using namespace hapnet::base;

#ifdef MUST_COMPILE
constexpr auto loss = Probability::from_fraction(0.93);
#else
constexpr Probability loss = 0.93;
#endif
