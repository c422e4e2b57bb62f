# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The emulator and hapnet-ctl.
#   scripts/package.sh --out packages
#   docker build -f packaging/docker/emulator.Dockerfile -t hapnet-emulator .
ARG BASE=debian:bookworm-slim
FROM ${BASE}
COPY packages/*.deb /packages/
RUN apt-get update \
    && apt-get install -y --no-install-recommends /packages/hapnet-emulator_*.deb \
    && rm -rf /packages /var/lib/apt/lists/*
USER nobody
ENTRYPOINT ["hapnet-emulator"]
