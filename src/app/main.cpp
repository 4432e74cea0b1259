#include "app/program.h"

int main(int argc, char** argv) { return static_cast<int>(winslow::app::run_program(argc, argv)); }
