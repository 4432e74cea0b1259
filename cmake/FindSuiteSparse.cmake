# Finds the parts of SuiteSparse that winslow uses: targets SuiteSparse::UMFPACK, SuiteSparse::KLU
# and SuiteSparse::CHOLMOD; variables SuiteSparse_UMFPACK_FOUND and so on.
include(FindPackageHandleStandardArgs)
find_path(SuiteSparse_INCLUDE_DIR klu.h umfpack.h cholmod.h PATH_SUFFIXES suitesparse)
foreach(part UMFPACK KLU CHOLMOD)
  string(TOLOWER ${part} lower)
  find_library(SuiteSparse_${part}_LIBRARY ${lower})
  mark_as_advanced(SuiteSparse_${part}_LIBRARY)
  if(SuiteSparse_INCLUDE_DIR AND SuiteSparse_${part}_LIBRARY
     AND EXISTS ${SuiteSparse_INCLUDE_DIR}/${lower}.h)
    set(SuiteSparse_${part}_FOUND TRUE)
    if(NOT TARGET SuiteSparse::${part})
      add_library(SuiteSparse::${part} UNKNOWN IMPORTED)
      set_target_properties(
        SuiteSparse::${part}
        PROPERTIES IMPORTED_LOCATION ${SuiteSparse_${part}_LIBRARY}
                   INTERFACE_INCLUDE_DIRECTORIES ${SuiteSparse_INCLUDE_DIR})
    endif()
  endif()
endforeach()
mark_as_advanced(SuiteSparse_INCLUDE_DIR)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS SuiteSparse_INCLUDE_DIR
                                  HANDLE_COMPONENTS)
