// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"

using namespace hapnet::base;

#ifdef MUST_COMPILE
const auto stream = Seed{42}.stream("up/loss");
#else
const RandomStream stream{42, 1};
#endif
