#pragma once
// STRIPACK's routines as Fortran symbols: ours (trmesh_, ...) by stripack.h of the library that is linked,
// and the original's (cstrfind_, ...) from libngmath, with the same arguments. Logical functions return 0 or
// not 0.

#include <stripack.h>

extern "C" {
decltype(addnod_) csaddnod_;
decltype(areas_) csareas_;
decltype(bdyadd_) csbdyadd_;
decltype(bnodes_) csbnodes_;
decltype(circum_) cscircum_;
decltype(covsph_) cscovsph_;
decltype(delarc_) csdelarc_;
decltype(delnb_) csdelnb_;
decltype(delnod_) csdelnod_;
decltype(edge_) csedge_;
decltype(getnp_) csgetnp_;
decltype(insert_) csinsert_;
decltype(inside_) csinside_;
decltype(intadd_) csintadd_;
decltype(intrsc_) csintrsc_;
decltype(jrand_) csjrand_;
decltype(left_) csleft_;
decltype(lstptr_) cslstptr_;
decltype(nbcnt_) csnbcnt_;
decltype(nearnd_) csnearnd_;
decltype(optim_) csoptim_;
decltype(store_) csstore_;
decltype(swap_) csswap_;
decltype(swptst_) csswptst_;
decltype(trfind_) cstrfind_;
decltype(trlist_) cstrlist_;
decltype(trlprt_) cstrlprt_;
decltype(trprnt_) cstrprnt_;
decltype(scoord_) csscoordd_;
decltype(trans_) cstransd_;
}
