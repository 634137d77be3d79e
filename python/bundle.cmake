# limn_bundle(TARGET) copies the shared library of an imported target into the wheel, beside the module. The copy is
# named liblimn_NAME.so. If another module of the process has loaded another version of the library, limn still uses its
# own.

find_program(LIMN_PATCHELF patchelf REQUIRED)

function(limn_bundle target)
    # Find the library. A static one needs no copy.
    foreach(config "_RELEASE" "_NONE" "_RELWITHDEBINFO" "")
        get_target_property(library ${target} IMPORTED_LOCATION${config})
        if(library)
            break()
        endif()
    endforeach()
    get_target_property(kind ${target} TYPE)
    if(kind STREQUAL "STATIC_LIBRARY")
        return()
    endif()
    if(NOT library)
        message(FATAL_ERROR "limn: no shared library of ${target}")
    endif()
    # Copy it and change its soname.
    string(REGEX REPLACE ".*::" "" name ${target})
    set(copy "${CMAKE_CURRENT_BINARY_DIR}/liblimn_${name}.so")
    file(REAL_PATH "${library}" original)
    file(COPY_FILE "${original}" "${copy}")
    execute_process(COMMAND "${LIMN_PATCHELF}" --set-soname liblimn_${name}.so "${copy}" COMMAND_ERROR_IS_FATAL ANY)
    # Let the target refer to the copy.
    foreach(config "_RELEASE" "_NONE" "_RELWITHDEBINFO" "")
        set_target_properties(${target} PROPERTIES
            IMPORTED_LOCATION${config} "${copy}" IMPORTED_SONAME${config} "liblimn_${name}.so")
    endforeach()
    install(FILES "${copy}" DESTINATION limn PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
endfunction()
