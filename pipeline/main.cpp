// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/tessera_main.hpp"

int main(int argc, char** argv) { return tessera::pipeline::tessera_main(argc, argv); }
