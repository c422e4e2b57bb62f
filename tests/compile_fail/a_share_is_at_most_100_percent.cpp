// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/probability.hpp"

using namespace hapnet::base::literals;

#ifdef MUST_COMPILE
constexpr auto loss = 93_percent;
#else
constexpr auto loss = 150_percent;
#endif
