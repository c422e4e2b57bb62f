# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Experiments in virtual time. Results go to /results.
#   scripts/package.sh --out packages
#   docker build -f packaging/docker/lab.Dockerfile -t hapnet-lab .
ARG BASE=debian:bookworm-slim
FROM ${BASE}
COPY packages/*.deb /packages/
RUN apt-get update \
    && apt-get install -y --no-install-recommends /packages/hapnet-emulator_*.deb /packages/hapnet_*.deb \
    && rm -rf /packages /var/lib/apt/lists/*
USER nobody
WORKDIR /results
ENTRYPOINT ["hapnet-lab"]
