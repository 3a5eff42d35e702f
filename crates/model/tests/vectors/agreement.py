"""Makes agreement.json with pingouin 0.7 and numpy 2.4: python agreement.py (in this folder)."""
import numpy as np, pandas as pd, pingouin as pg, json
rng=np.random.default_rng(20240305)
out={}
n,k=12,4
true=rng.uniform(60,200,n); bias=np.array([0.5,-1.5,2.0,0.0])
tab=true[:,None]+bias[None,:]+rng.normal(0,4,(n,k))
tab=np.round(tab,2)
def icc(tab):
    n,k=tab.shape
    df=pd.DataFrame([(i,j,tab[i,j]) for i in range(n) for j in range(k)],columns=['t','r','v'])
    r=pg.intraclass_corr(df,targets='t',raters='r',ratings='v')
    row=r[r['Type'].isin(['ICC2','ICC(A,1)'])].iloc[0]
    return float(row['ICC'])
# full-precision ICC(2,1): undo pingouin's rounding if any by printing
out['simulated']={'ratings':tab.tolist(),'truth':np.round(true,2).tolist(),'icc_2_1':icc(tab)}
v=np.array([[25.7,25.18,7.17,26.37],[15.1,15.75,15.1,15.39],[14.83,15.2,15.41,15.25]])
out['table_v']={'ratings':v.tolist(),'icc_2_1':icc(v)}
h=np.array([[3.46,1.563,5.66,2.98],[6.185,9.62,6.7,5.841],[5.792,8.3,8.06,7.556]])
out['table_vi']={'ratings':h.tolist(),'icc_2_1':icc(h)}
a=tab[:,0];b=tab[:,1]
t=pg.ttest(a,b,paired=True)
out['paired']={'a':a.tolist(),'b':b.tolist(),'t':float((a-b).mean()/((a-b).std(ddof=1)/np.sqrt(len(a)))),'t_pingouin':float(t['T'].iloc[0]),'p_pingouin':float(t[[c for c in t.columns if c.startswith('p')][0]].iloc[0])}
e=100*(a-np.array(out['simulated']['truth']))/np.array(out['simulated']['truth'])
out['errors']={'values':e.tolist(),'mean':float(e.mean()),'sd':float(e.std(ddof=1)),'rmse':float(np.sqrt((e**2).mean())),'mae':float(np.abs(e).mean()),'median':float(np.median(e)),'q95_absolute':float(np.quantile(np.abs(e),.95)),'max_absolute':float(np.abs(e).max()),'loa':[float(e.mean()-1.959963984540054*e.std(ddof=1)),float(e.mean()+1.959963984540054*e.std(ddof=1))]}
out['made_by']='pingouin '+pg.__version__+', numpy '+np.__version__
json.dump(out,open('agreement.json','w'),indent=1)
