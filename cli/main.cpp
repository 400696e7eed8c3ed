#include "cli/program.h"

int main(int argc, char** argv) { return relock::run_program(argc, argv, relock::builtin_methods()); }
