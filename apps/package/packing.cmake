# Read by cpack.
if(CPACK_GESTELL_NATIVE)
  message(WARNING "This package runs on processors as the one it was built on. For others: cmake --preset package")
endif()
